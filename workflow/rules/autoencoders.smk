# One autoencoder per variant, latent dimension and seed; POD beside them in the table.


rule train_autoencoder:
    input:
        dataset="results/dataset/train.parquet",
        shapes="results/terminal_shapes/train.parquet",
    output:
        model_files("results/models/autoencoders/{variant}_d{dim}_s{seed}"),
    log:
        "results/logs/train_autoencoder/{variant}_d{dim}_s{seed}.log",
    benchmark:
        "results/benchmarks/train_autoencoder/{variant}_d{dim}_s{seed}.tsv"
    group:
        "autoencoders"
    conda:
        "../../envs/learning.yaml"
    threads: 1
    resources:
        mem_mb=2000,
        runtime=20,
    params:
        code=code_of("train_autoencoder"),
        settings=as_json(config["autoencoders"]["settings"]),
        folder=lambda wildcards, output: Path(output[0]).parent,
    message:
        "train autoencoder {wildcards.variant}, d={wildcards.dim}, seed {wildcards.seed}"
    shell:
        "sedfiber train_autoencoder --dataset {input.dataset} --terminal-shapes {input.shapes}"
        " --variant {wildcards.variant} --latent-dim {wildcards.dim} --seed {wildcards.seed}"
        " --settings {params.settings:q} -o {params.folder} 2>&1 | tee {log}"


rule tabulate_reconstruction:
    input:
        dataset="results/dataset/train.parquet",
        shapes="results/terminal_shapes/train.parquet",
        tests=expand("results/dataset/{split}.parquet", split=TEST_SETS),
        test_shapes=expand("results/terminal_shapes/{split}.parquet", split=TEST_SETS),
        models=[model_files(folder) for folder in AUTOENCODERS],
    output:
        "results/tables/reconstruction.csv",
    log:
        "results/logs/tabulate_reconstruction.log",
    benchmark:
        "results/benchmarks/tabulate_reconstruction.tsv"
    conda:
        "../../envs/learning.yaml"
    threads: 1
    resources:
        mem_mb=4000,
        runtime=10,
    params:
        code=code_of("tabulate_reconstruction"),
        models=AUTOENCODERS,
    message:
        "tabulate the reconstruction loss of all autoencoders and of POD"
    shell:
        "sedfiber tabulate_reconstruction --dataset {input.dataset} --terminal-shapes {input.shapes}"
        " --models {params.models} --test-datasets {input.tests} --test-shapes {input.test_shapes}"
        " -o {output} > {log} 2>&1"


rule autoencoders:
    input:
        rules.tabulate_reconstruction.input.models,
        rules.tabulate_reconstruction.output,
